// Not tested on hardware.
#include "link.h"
#include "sdkconfig.h"

#ifdef CONFIG_PROBE_LINK_UDP

#include <errno.h>
#include <string.h>

#include "esp_event.h"
#include "esp_netif.h"
#include "esp_wifi.h"
#include "lwip/sockets.h"
#include "nvs_flash.h"

static int s_socket = -1;

static void on_wifi(void* context, esp_event_base_t base, int32_t id, void* data) {
  (void)context;
  (void)base;
  (void)data;
  if (id == WIFI_EVENT_STA_START || id == WIFI_EVENT_STA_DISCONNECTED) {
    esp_wifi_connect();
  }
}

static bool join_network(void) {
  if (nvs_flash_init() != ESP_OK && (nvs_flash_erase() != ESP_OK || nvs_flash_init() != ESP_OK)) {
    return false;
  }
  if (esp_netif_init() != ESP_OK || esp_event_loop_create_default() != ESP_OK) {
    return false;
  }
  esp_netif_create_default_wifi_sta();
  const wifi_init_config_t init = WIFI_INIT_CONFIG_DEFAULT();
  wifi_config_t config = {0};
  strlcpy((char*)config.sta.ssid, CONFIG_PROBE_WIFI_SSID, sizeof config.sta.ssid);
  strlcpy((char*)config.sta.password, CONFIG_PROBE_WIFI_PASSWORD, sizeof config.sta.password);
  return esp_wifi_init(&init) == ESP_OK &&
         esp_event_handler_register(WIFI_EVENT, ESP_EVENT_ANY_ID, on_wifi, NULL) == ESP_OK &&
         esp_wifi_set_mode(WIFI_MODE_STA) == ESP_OK && esp_wifi_set_config(WIFI_IF_STA, &config) == ESP_OK &&
         esp_wifi_start() == ESP_OK &&
         // Sleeping between beacons would hold frames back for 100 ms.
         esp_wifi_set_ps(WIFI_PS_NONE) == ESP_OK;
}

bool link_udp_start(void) {
  if (!join_network()) {
    return false;
  }
  struct sockaddr_in host = {.sin_family = AF_INET, .sin_port = htons(CONFIG_PROBE_PORT)};
  s_socket = socket(AF_INET, SOCK_DGRAM, IPPROTO_UDP);
  // Connected: only the host is heard.
  return s_socket >= 0 && inet_pton(AF_INET, CONFIG_PROBE_HOST, &host.sin_addr) == 1 &&
         connect(s_socket, (struct sockaddr*)&host, sizeof host) == 0;
}

size_t link_udp_write(void* context, const uint8_t* bytes, size_t count) {
  (void)context;
  // A datagram that the network takes no memory for is tried again; one that has no way is dropped, as UDP may.
  if (send(s_socket, bytes, count, MSG_DONTWAIT) < 0 && (errno == EAGAIN || errno == ENOMEM)) {
    return 0;
  }
  return count;
}

size_t link_udp_read(void* context, uint8_t* bytes, size_t capacity) {
  (void)context;
  const int count = recv(s_socket, bytes, capacity, MSG_DONTWAIT);
  return count > 0 ? (size_t)count : 0;
}

#endif
